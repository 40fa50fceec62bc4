"""scripts/bank"""
