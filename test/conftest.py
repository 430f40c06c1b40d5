"""How the tests run, wherever they run."""
from hypothesis import Phase, settings

settings.register_profile('rocon_uri', deadline=None)     # a busy machine is no failure
settings.register_profile(      # where it matters that a test fails, and not of what
    'no_shrinking', deadline=None, report_multiple_bugs=False,
    phases=[Phase.explicit, Phase.generate])
settings.load_profile('rocon_uri')
