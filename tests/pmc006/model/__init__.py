"""tests/pmc006/model"""
