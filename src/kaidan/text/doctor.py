"""What is installed, as text."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.doctor import Diagnosis, Extra

KERNELS = {
    "native": "native: machine code, built when kaidan was installed",
    "plain": "plain: ordinary Python, about a hundred times slower, the same answers",
}


def text(found: "Diagnosis") -> str:
    """The kernel first, what to do where it is the slow one, then the optional parts."""
    lines = [
        f"kaidan {found.kaidan}, Python {found.python}, {found.machine}",
        f"contact kernel   {KERNELS[found.kernel]}",
    ]
    if found.without_native:
        lines.append(f"  {found.without_native}")
        lines.append("  do: install a C compiler, then kaidan again")
    elif found.kernel == "plain":
        lines.append("  chosen by KAIDAN_KERNEL or use_kernel; the native one is there")
    width = max((len(extra.name) for extra in found.extras), default=0)
    lines += [
        "optional parts",
        *(f"  {each.name:<{width}}  {_state(each)}" for each in found.extras),
    ]
    return "\n".join(lines)


def _state(extra: "Extra") -> str:
    if not extra.missing:
        return "installed"
    return f"pip install 'kaidan[{extra.name}]' (not there: {', '.join(extra.missing)})"
