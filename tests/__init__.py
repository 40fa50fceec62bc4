"""Python tests of golden models, host package, command line and scripts: one folder per device, one
common.
"""
