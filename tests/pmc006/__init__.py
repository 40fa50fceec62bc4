"""tests/pmc006"""
