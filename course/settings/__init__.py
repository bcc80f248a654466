"""What course.toml, roster.csv and other files that people keep say, checked."""
