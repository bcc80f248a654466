"""What students got: results, grades, marks by hand, and what they tell of a class."""
