"""Sheets drawn, recorded and written for every student."""
