"""Formats of files as plain arrays, and how files appear whole or not at all. Nothing here knows a System."""
