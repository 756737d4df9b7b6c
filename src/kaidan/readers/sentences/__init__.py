"""What readers say of files."""
