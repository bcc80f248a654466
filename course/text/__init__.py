"""Text made ready for where it goes: pages, terminals, spreadsheets, Markdown, formulas."""
