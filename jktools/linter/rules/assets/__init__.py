"""What is wrong inside the files that a level refers to."""
