"""Old name of `env.py`; it will be removed in the next minor version."""

from openppmc.lazy import renamed

from .env import Env as Env

__getattr__ = renamed(__name__, {"Lab": "Env"})
