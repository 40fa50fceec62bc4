"""Tests in Python: golden models, host package, command line, scripts; one folder per device, one common."""
