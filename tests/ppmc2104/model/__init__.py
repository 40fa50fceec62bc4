"""tests/ppmc2104/model"""
