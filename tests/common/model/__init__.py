"""Tests of components that the golden models of several devices share."""
