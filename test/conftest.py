"""How the tests run, wherever they run."""
from hypothesis import settings

settings.register_profile('rocon_uri', deadline=None)     # a busy machine is no failure
settings.load_profile('rocon_uri')
