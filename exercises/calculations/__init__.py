"""What several exercises compute, right and in the ways in which it goes wrong."""
