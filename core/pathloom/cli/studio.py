"""``pathloom studio``: a local web page on which one draws a map and watches planners evolve paths."""

import click

from pathloom.cli import DONE

PORT = 8617


@click.command("studio")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=PORT, show_default=True, help="On 127.0.0.1; 0 takes a free one."
)
@click.option("--no-browser", is_flag=True, help="Only print the address.")
@click.pass_context
def command(ctx: click.Context, /, port: int, no_browser: bool) -> None:
    """Draw obstacles, drag start and goal, and watch a population evolve, in the browser.

    The page is served on this machine only, at the address that is printed, and
    asks nothing of any other. Ctrl-C ends it.
    """
    try:
        from pathloom.studio.serving import serve
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("starlette", "uvicorn"):
            raise
        raise click.ClickException(f"studio: needs {error.name}; pip install 'pathloom[studio]'") from error

    def ready(address: str) -> None:
        click.echo(address)
        if not no_browser:
            import webbrowser

            webbrowser.open(address)

    try:
        serve(port, ready)
    except KeyboardInterrupt:  # the usual way to end it
        ctx.exit(DONE)
