"""From a file to raw values: notebooks run in a process of their own, MATLAB files are read."""
