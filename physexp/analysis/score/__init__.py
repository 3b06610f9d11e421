"""The score: plays a fixed protocol with any experimenter, and compares its actions with those of the ideal."""
