"""One module for each format, with ``read(source, hints)``: what a file holds, as it holds it."""
