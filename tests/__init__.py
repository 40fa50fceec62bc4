"""Python tests of golden models, host package, command line and scripts: a folder for each device, and
`common`.
"""
