"""The exercises, one file each; none imports another."""
