"""Known mistakes as data, and one pipeline that makes all of them at once."""
