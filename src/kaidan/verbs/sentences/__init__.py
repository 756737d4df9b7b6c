"""What verbs say within their answers."""
