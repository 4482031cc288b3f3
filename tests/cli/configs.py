"""Configs that the tests run, freeze and hold against the schema."""

EVERY_SECTION = """
[problem]
map = "iga-map1"
start = "bottom-left"
goal = [0, 9]
corners = "allow"
radius = 0.0
unknown = "free"

[planner]
use = "imga"
population = 30
repair = "none"

[planner.sampling]
use = "perturbed-trees"

[planner.selection]
use = "tournament"

[planner.crossover]
use = "imga/common-node"
rate = 0.7

[planner.mutation]
use = "d8-gene-median"

[planner.objectives]
length = 6.0
safety = { use = "imga/unsafe-node", weight = 1.0, penalty = 4.0 }
turns = { use = "turns", weight = 2.0 }

[planner.survival]
use = "keep-best"

[[planner.termination]]
use = "max-generations"
limit = 8

[[planner.termination]]
use = "stagnation"
patience = 6

[[planner.observers]]
use = "json-lines"
file = "log.jsonl"

[[planner.observers]]
use = "snapshots"
every = 4

[run]
seed = 7
time_limit = 60
"""

PLANNER_ONLY = '[planner]\nuse = "baselines/ga-imga"\n'

NO_PLANNER_NAMED = '[planner]\npopulation = 20\n[planner.selection]\nuse = "roulette"\n[problem]\nmap = "iga-map1"\n'

EMPTY_SLOTS = """
[problem]
map = "iga-map1"
corners = "allow"
[planner]
crossover = "none"
refinement = "none"
archive = "none"
termination = [{ use = "max-generations", limit = 3 }]
"""

ALL = {
    "every section": EVERY_SECTION,
    "a planner and nothing else": PLANNER_ONLY,
    "no planner named": NO_PLANNER_NAMED,
    "empty slots": EMPTY_SLOTS,
    "nothing at all": "",
}
