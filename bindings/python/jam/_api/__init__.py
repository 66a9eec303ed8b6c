"""The C functions as Python calls them: enums and reports, arrays and options, errors. Nothing here knows a System."""
