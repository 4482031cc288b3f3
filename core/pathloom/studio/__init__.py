"""The studio: a local web page on which one draws a map and watches planners evolve paths.

The page asks for every generation that it shows (`wire.More`), so that nothing piles up anywhere: a slow tab
slows its own run, a closed one ends it. `app` puts it together; `security` says who may speak to it.
"""
