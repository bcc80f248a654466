"""Files from and for the systems that courses use: Moodle, Canvas, Gradescope, and others."""
