"""Zip files that somebody hands us: what reading one may raise."""

import zipfile
import zlib

UNREADABLE = (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError)
"""Of a file that is no zip, of damaged content, of content that is cut off; and of what is locked, or packed in a way
that zipfile does not know (`NotImplementedError`, which is a `RuntimeError`)."""
