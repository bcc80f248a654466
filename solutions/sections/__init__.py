"""Workspace sections: where arms reach, where they stand at a boundary, and the lines between."""
