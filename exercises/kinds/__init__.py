"""The kinds of answers, one file a kind: asked, brought to their kind, pictured, written down."""
