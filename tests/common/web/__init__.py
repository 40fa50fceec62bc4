"""Tests of the playground: modules against the golden models, its engine under node, the page in a
browser.
"""
