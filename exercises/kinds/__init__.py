"""The kinds of answers, one file a kind: what is asked, brought to its kind, pictured as numbers, written down."""
