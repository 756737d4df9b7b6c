"""Verdicts, reasons and advice in sentences."""
