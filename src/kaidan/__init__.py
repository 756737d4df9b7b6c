"""kaidan: can this tracked robot take these stairs?"""

__version__ = "0.1.0"
