"""tests/ppmc104/model"""
