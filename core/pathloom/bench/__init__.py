"""Benchmarks that anybody can rerun: ``python -m pathloom.bench``.

Our planners and what one would take instead, on the same maps in one run. Each
path is judged by our validators, whoever made it.
"""
