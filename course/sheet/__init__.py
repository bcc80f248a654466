"""What is handed out and handed in: notebooks, MATLAB scripts, and how they are read back."""
