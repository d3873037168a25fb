"""Interfaces of other programs."""
