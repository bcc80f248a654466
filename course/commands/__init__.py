"""The commands behind `kinegrade`, and what they alone need."""
