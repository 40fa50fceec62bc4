"""tests/ppmc312/model"""
