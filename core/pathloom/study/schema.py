"""Schema: the tables of a study's file, and how older files become newer ones.

A study is one SQLite file, readable with any SQLite. JSON is text; blobs are
JSON compressed with zlib. Lengths are in cells, cells are row and column from
the top left. ``SELECT * FROM results`` gives what `pathloom study export` writes.

``study``         name and value (JSON): kind, design, budget, number of runs, first seed, notes
``environments``  versions and machine with which runs were made
``variants``      one a method: its complete config, what it changes of the base, the config's SHA-256
``maps``          one a map: its cells, as packed bits (numpy.packbits) compressed with zlib
``instances``     one a problem: map, start, goal, corner policy, radius, and the exact optima
``runs``          one a run. ``id`` only joins tables: it follows the order in which runs happened to finish;
                  ``hash`` is the SHA-256 of config, map, start, goal, corners, radius, seed and versions
``traces``        of a run: history, path, and for several objectives the front
"""

APPLICATION = 0x504C5354
"""What marks an SQLite file as a study ("PLST")."""

MIGRATIONS: tuple[str, ...] = (
    """
CREATE TABLE study (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE environments (id INTEGER PRIMARY KEY, versions TEXT NOT NULL UNIQUE);
CREATE TABLE variants (
    id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, planner TEXT NOT NULL,
    config TEXT NOT NULL, sha256 TEXT NOT NULL, changes TEXT NOT NULL
);
CREATE TABLE maps (
    sha256 TEXT PRIMARY KEY, height INTEGER NOT NULL, width INTEGER NOT NULL, cells BLOB NOT NULL
) WITHOUT ROWID;
CREATE TABLE instances (
    id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, map TEXT NOT NULL,
    map_sha256 TEXT NOT NULL REFERENCES maps, resolution REAL NOT NULL, origin TEXT,
    start_row INTEGER NOT NULL, start_col INTEGER NOT NULL, goal_row INTEGER NOT NULL, goal_col INTEGER NOT NULL,
    corners TEXT NOT NULL, radius REAL NOT NULL, stated_optimum REAL,
    measured INTEGER NOT NULL DEFAULT 0,   -- whether the optima below are as well known as they will be
    reachable INTEGER, optimum_grid REAL, optimum_any_angle REAL, any_angle_bound REAL,
    exact_front BLOB, reference_point TEXT, note TEXT
);
CREATE TABLE runs (
    id INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE,
    variant INTEGER NOT NULL REFERENCES variants, instance INTEGER NOT NULL REFERENCES instances,
    seed INTEGER NOT NULL, environment INTEGER NOT NULL REFERENCES environments, status TEXT NOT NULL,
    length REAL, fitness REAL, turns INTEGER, turn_angle REAL, min_clearance REAL, unsafe_nodes INTEGER, nodes INTEGER,
    gap_grid REAL, gap_any_angle REAL, gap_bound REAL, hypervolume REAL, hypervolume_ratio REAL,
    evaluations INTEGER, evaluations_to_first INTEGER, evaluations_to_one_percent INTEGER, generations INTEGER,
    seconds REAL, error TEXT,
    phases TEXT,                           -- seconds by phase
    objectives TEXT,                       -- values of the planner's objectives
    counts TEXT,                           -- failures and fallbacks that operators counted
    attempts INTEGER NOT NULL,             -- how often it was begun: more than once where a worker was lost
    UNIQUE (instance, seed, variant)
);
CREATE TABLE traces (run INTEGER PRIMARY KEY REFERENCES runs, history BLOB, path BLOB, front BLOB);
CREATE VIEW results AS
SELECT v.name AS variant, v.planner, i.name AS map, r.seed, r.status, r.length, r.fitness, r.turns, r.turn_angle,
    r.min_clearance, r.unsafe_nodes, r.nodes, r.gap_grid, r.gap_any_angle, r.gap_bound, r.hypervolume,
    r.hypervolume_ratio, r.evaluations, r.evaluations_to_first, r.evaluations_to_one_percent, r.generations,
    r.seconds, r.error
FROM runs r JOIN variants v ON v.id = r.variant JOIN instances i ON i.id = r.instance
ORDER BY r.instance, r.seed, r.variant;
""",
)
"""What takes a file from each version to the next; a new file begins at version 0."""

VERSION = len(MIGRATIONS)
