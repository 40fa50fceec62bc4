"""scripts/ppmc104"""
