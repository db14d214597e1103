# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""
Do tests fail now and then? ``python test/repeat.py 20 test/nodes`` runs them twenty times.

Everything after the number goes to pytest. Each run is told when it is over, the last lines say
which tests failed how often; the exit code is that number, at most 1.
"""

from collections import Counter
from pathlib import Path
import subprocess
import sys
from tempfile import TemporaryDirectory
import time
from xml.etree import ElementTree

ROOT = Path(__file__).parents[1]


def run(arguments: list[str], folder: Path) -> tuple[int, list[str]]:
    """Run pytest once; return how many tests there were, and what failed with its reason."""
    result = folder / 'result.xml'
    result.unlink(missing_ok=True)
    command = [sys.executable, '-m', 'pytest', '-q', f'--junit-xml={result}', *arguments]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if not result.exists():
        sys.exit(f'pytest did not run:\n{done.stdout}{done.stderr}')
    cases = list(ElementTree.parse(result).getroot().iter('testcase'))
    failed = []
    for case in cases:
        for fault in (*case.findall('failure'), *case.findall('error')):
            reason = (fault.get('message') or '').splitlines()[:1]
            failed.append(f'{case.get("classname")}::{case.get("name")} {"".join(reason)}')
    return len(cases), failed


def main(number: int, arguments: list[str]) -> int:
    """Run the tests so many times; return the exit code."""
    faults: Counter[str] = Counter()
    with TemporaryDirectory() as folder:
        for count in range(1, number + 1):
            began = time.monotonic()
            tests, failed = run(arguments, Path(folder))
            faults.update(failed)
            taken = time.monotonic() - began
            print(f'run {count}: {tests} tests, {len(failed)} failed, {taken:.0f} s', flush=True)
            for line in failed:
                print(f'  {line}', flush=True)
    print(f'{number} runs, {faults.total()} failures')
    for line, times in faults.most_common():
        print(f'{times} x {line}')
    return min(faults.total(), 1)


if __name__ == '__main__':
    sys.exit(main(int(sys.argv[1]), sys.argv[2:]))
