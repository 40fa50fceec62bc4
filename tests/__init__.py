"""Tests in Python: golden models, host package, command line, scripts; a folder a part and a common one."""
