"""scripts/ppmc312"""
