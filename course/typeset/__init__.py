"""Sheets, answer sheets and worked solutions as PDF, set by Typst."""
