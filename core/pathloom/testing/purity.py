"""Purity: a component changes nothing that it is handed, prints nothing, and is finished with what it is asked."""

from pathloom.kernel.component import Component
from pathloom.testing.calls import called
from pathloom.testing.check import expect, promise
from pathloom.testing.trial import trials


@promise("answers", where=called)
def answers(component: Component) -> None:
    """It raises nothing on ordinary problems; what cannot be done is counted."""
    for trial in trials(component):
        if trial.error is not None:
            raised = f"{type(trial.error).__name__}: {trial.error}"
            expect(False, f"expected an answer {trial.call.what}; found {raised}")


@promise("inputs-kept", where=called)
def inputs_kept(component: Component) -> None:
    """Populations, states, problems and the component itself are as they were before the call."""
    for trial in trials(component):
        expect(not trial.altered, f"expected its inputs as they were; found {trial.altered} changed {trial.call.what}")


@promise("silent", where=called)
def silent(component: Component) -> None:
    """It prints nothing on standard output, which belongs to whoever runs it."""
    for trial in trials(component):
        expect(not trial.printed, f"expected nothing printed; found {trial.printed!r} printed {trial.call.what}")


CHECKS = (answers, inputs_kept, silent)
