"""scripts/stmc"""
