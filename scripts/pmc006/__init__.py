"""scripts/pmc006"""
