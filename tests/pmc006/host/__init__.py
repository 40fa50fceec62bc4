"""tests/pmc006/host"""
