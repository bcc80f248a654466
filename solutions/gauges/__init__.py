"""Gauges between the frames of two chains, which tell whether both are one mechanism."""
