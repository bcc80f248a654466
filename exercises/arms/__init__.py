"""Arms that exercises show: how they are drawn, described and misread."""
