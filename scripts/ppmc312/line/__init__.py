"""scripts/ppmc312/line"""
