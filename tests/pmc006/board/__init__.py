"""tests/pmc006/board"""
