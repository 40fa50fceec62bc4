"""tests/pmc006/cli"""
