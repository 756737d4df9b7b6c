"""What the models say of what they found."""
