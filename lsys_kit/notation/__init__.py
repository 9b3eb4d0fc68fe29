"""Text to records and back. Knows no numbers' meaning, no pictures, no files."""
