"""scripts/ppmc2104"""
