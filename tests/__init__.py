"""Tests in Python: golden models, host package, command line, scripts; a folder per device and a common one."""
