# Copyright 2026 the contact_tracking authors
# SPDX-License-Identifier: Apache-2.0
"""The report of [ZHUK09]; its figures are tested in test/tracking_core/test_zhuk_2009.py."""

from __future__ import annotations

from studies import zhuk_2009


def test_report_is_written_with_its_figures(tmp_path) -> None:
    """Few runs: Markdown with the joint filter in its table, both pictures beside it."""
    report = zhuk_2009.describe(20, tmp_path)
    assert 'joint over decomposed RMSE, Z-0, manoeuvre' in report
    for picture in ('zhuk_2009_modes.png', 'zhuk_2009_forecast.png'):
        assert picture in report
        assert (tmp_path / picture).stat().st_size > 5_000
