"""pymoo: the multi-objective algorithms of pymoo on pathloom's operators, and the operators inside pymoo."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the multi-objective planners."""
    from pathloom_pymoo.age_moea import AgeMoea
    from pathloom_pymoo.moead import Moead
    from pathloom_pymoo.nsga2 import Nsga2
    from pathloom_pymoo.nsga3 import Nsga3
    from pathloom_pymoo.rvea import Rvea
    from pathloom_pymoo.sms_emoa import SmsEmoa
    from pathloom_pymoo.spea2 import Spea2

    for component in (Nsga2, Nsga3, SmsEmoa, AgeMoea, Moead, Rvea, Spea2):
        add(component)
