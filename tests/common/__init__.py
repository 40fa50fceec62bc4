"""Tests that do not belong to one device."""
