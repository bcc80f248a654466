"""A class marked: what came in, what is to do, every grade saved as it comes."""
