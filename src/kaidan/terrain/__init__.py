"""What is to be climbed: stairs, and profiles of any shape."""
