"""The kinds of answers, one file a kind: read from raw values, compared, handed in again."""
