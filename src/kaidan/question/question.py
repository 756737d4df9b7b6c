"""The question as a sheet: made of what people write, changed, and what follows from it."""

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

from kaidan.allowance import Allowance
from kaidan.arguments import known_arguments
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import kinetic_energy_height, sudden_stop_height
from kaidan.mechanics.yielding import drop_of_sag
from kaidan.modes import MODELS, PHYSICS
from kaidan.question.fields import FACINGS, TRACKS, QuestionFields
from kaidan.question.refusals import refuse_impossible
from kaidan.question.room import Needs, needs_of
from kaidan.question.yielding import ROCKING_SPEED, allowance_d, theta_d_at
from kaidan.robot import Posture
from kaidan.sheet import model_validator
from kaidan.spelling import (
    BEST,
    UNCERTAINTIES,
    allowance_of,
    doubted,
    doubted_terrain,
    figures,
    payloads_of,
    postures_of,
    quantity_of,
    robot_of,
    surface_of,
    terrain_of,
    word_of,
)
from kaidan.terrain.stairs import Stairs

if TYPE_CHECKING:
    from kaidan.outline import Outline

FLIPPER_TOLERANCE = 0.03490658503988659
"""How far off its angles a plan that is found has to hold where nobody says, 2 degrees [rad]: an
operator sets a flipper by an indicator of whole degrees, and it gives under load."""


def _optional(name: str, given: Any, kind: str) -> float | None:
    """Number of what people write; None where they wrote nothing."""
    return None if given is None else quantity_of(name, given, kind)


class Question(QuestionFields):
    """Can this robot take this terrain, in this manner, with this much risk?"""

    @model_validator(mode="after")
    def _possible(self) -> Self:
        refuse_impossible(self)
        return self

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal, whatever has been worked out from them already."""
        if not isinstance(other, Question):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in type(self).model_fields)

    __hash__ = QuestionFields.__hash__

    @classmethod
    @known_arguments
    def of(
        cls,
        robot: Any,
        stairs: Any,
        *,
        surface: Any = None,
        friction: Any = None,
        acceleration: Any = 0.0,
        speed: Any = None,
        direction: str | None = None,
        facing: str | None = None,
        flippers: Any = None,
        flipper_tolerance: Any = None,
        payload: Any = (),
        theta_d: Any = None,
        theta_M: Any = None,
        fall_reserve: Any = None,
        yaw: Any = 0.0,
        risk: Any = 0.01,
        model: str = "contact",
        trials: Any = 1,
        track: str | None = None,
        uniform_across: bool = False,
        override: Any = (),
        uncertainty: Any = (),
    ) -> Self:
        """Question of what people write.

        Parameters
        ----------
        robot : Robot, str or path
            Robot, its name in the catalogue, or a TOML file.
        stairs : Stairs, Profile, str, path or a sequence of flights
            Stairs, their name in the catalogue, or a TOML file; several flights from bottom to
            top (also as one text, joined by "+"); or a profile of any shape.
        surface : Surface, str or path, optional
            Surface under the tracks; without one, and without *friction*, no GO is given.
        friction : float, (low, high) or str, optional
            Static friction instead of a surface [1]; a range as a pair or as "0.6..1.0".
        acceleration : float or str
            Up the stairs, whichever way the robot goes [m/s^2]; or a text such as "0.3m/s2".
        speed : float or str, optional
            [m/s]; or a text such as "0.2m/s".
        direction : {"up", "down"}, optional
            Which way the robot goes; the stairs sheet's without one.
        facing : {"nose-first", "tail-first"}, optional
            Which end leads; without it the nose, or with "best" flippers whichever is better.
        flippers : Posture, (Posture, PostureChange, ...) or str, optional
            "stowed", "flat", or angles: "20deg,-5deg" (front, rear); a plan by phase:
            "flat/land:-60deg,-20deg"; or "best", as without it: the contact model, straight on,
            finds a plan; at a yaw, and by other models, the better of stowed and flat is found.
            Trials of physics keep one posture: stowed without any.
        flipper_tolerance : float or str, optional
            How far off their angles the flippers may lie without a worse verdict [rad]; or "3deg".
            A flipper that is stowed lies at its stop. Without it 2 degrees where the contact model
            finds a plan, else 0.
        payload : Payload, str or a sequence of them
            Masses fixed to the robot; as text "5kg@200mm,300mm".
        theta_d, theta_M : float, (low, high), str or None
            Measured allowances of Eq. (24) [rad], or "1deg..2.6deg"; None takes the robot
            sheet's, else 0 to 2.6 degrees each (theta_M is zero when descending).
        fall_reserve : float or str, optional
            Tilt to the fall that a robot that rocks must keep [rad]; or "6deg"; None takes the
            robot sheet's, else 8 degrees.
        yaw : float or str
            Heading off the line of steepest ascent, to the left positive [rad]; or "10deg".
        risk : float
            Probability of failure that the operator accepts.
        model : {"contact", "closed-form", "support-polygon", "physics"}
            Which model answers.
        trials : int
            Of the physics: so many, each with inputs drawn of their doubt.
        track : {"smooth-belt", "yielding-belt", "driven-grousers"}, optional
            Of the physics; without it yielding-belt where the sheet says how it yields, else
            smooth-belt.
        uniform_across : bool
            Whether both tracks meet the same profile, of one that is no flight, step, ramp or
            threshold; without it such a profile is no GO.
        override : mapping or str
            The user's own figures for the robot: {"com_height": 0.2} or "com_height=200mm".
        uncertainty : mapping or str
            Standard uncertainties: {"angle": 0.01} or "angle=0.5deg"; of com_from_front,
            com_height, flat_length, angle, nosing_spacing, friction; and of each single rise and
            going: "rise=3mm,going=3mm".

        Raises
        ------
        InputError
            An input without physical meaning; the text names it.
        """
        sheet = robot_of(robot, override)
        doubts = figures(uncertainty, UNCERTAINTIES, "uncertainty")
        ground = surface_of(surface, friction, doubts)
        terrain = doubted_terrain(terrain_of(stairs), doubts)
        if direction is None:
            direction = terrain.direction if isinstance(terrain, Stairs) else "up"
        model = word_of("model", model, tuple(MODELS))
        if flippers is None:
            flippers = "stowed" if model == PHYSICS.name else BEST
        best = isinstance(flippers, str) and flippers.strip() == BEST
        posture, changes = (Posture(), ()) if best else postures_of(flippers, sheet)
        free = ["flippers"] if sheet.flippers() or sheet.states else []
        free += ["facing"] if facing is None else []
        return cls(
            robot=doubted(sheet, doubts, "com_from_front", "com_height", "flat_length"),
            terrain=terrain,
            uniform_across=uniform_across,
            surface=ground,
            direction=word_of("direction", direction, ("up", "down")),
            facing=word_of("facing", "nose-first" if facing is None else facing, FACINGS),
            acceleration=quantity_of("acceleration", acceleration, "acceleration"),
            speed=_optional("speed", speed, "speed"),
            posture=posture,
            changes=changes,
            best_of=tuple(free) if best else (),
            flipper_tolerance=_optional("flipper_tolerance", flipper_tolerance, "angle"),
            payload=tuple(payloads_of(payload)),
            theta_d=allowance_of("theta_d", theta_d),
            theta_M=allowance_of("theta_M", theta_M),
            fall_reserve=_optional("fall_reserve", fall_reserve, "angle"),
            yaw=quantity_of("yaw", yaw, "angle"),
            risk=quantity_of("risk", risk, "number"),
            model=model,
            trials=trials,
            track=None if track is None else word_of("track", track, TRACKS),
        )

    @classmethod
    def ask(cls, robot: Any, stairs: Any = None, **manner: Any) -> Self:
        """Question of what people write, see `of`; or the one given, with what they change of it.

        A change is written as in `of`: `Question.ask(question, friction="0.6..1.0")`.
        """
        if not isinstance(robot, cls):
            return cls.of(robot, stairs, **manner)
        if stairs is not None:
            raise InputError("a question has its stairs already; change them with changed()")
        if not manner:
            return robot
        fields = {name: getattr(robot, name) for name in cls.model_fields}
        sheet, terrain = fields.pop("robot"), fields.pop("terrain")
        fields["flippers"] = (fields.pop("posture"), *fields.pop("changes"))
        found = fields.pop("best_of")
        if manner.get("flippers", BEST if found else "") == BEST:
            fields["flippers"] = BEST
            if "facing" in found or "flippers" in manner:
                fields["facing"] = None
        if manner.get("friction") is not None:
            del fields["surface"]
        return cls.of(sheet, terrain, **fields | manner)

    @classmethod
    def in_one_posture(cls, robot: Any, stairs: Any = None, **manner: Any) -> Self:
        """Question as `ask` makes it, for what knows no plan: stowed where no posture is stated."""
        if not isinstance(robot, cls) and manner.get("flippers") is None:
            manner["flippers"] = "stowed"
        return cls.ask(robot, stairs, **manner)

    def changed(self, **changes: Any) -> Self:
        """Same question with something changed, validated again."""
        fields = {name: getattr(self, name) for name in type(self).model_fields}
        return type(self)(**fields | changes)

    @property
    def flippers(self) -> str:
        """Postures as the option is written."""
        changes = (f"/{each.before}:{each.posture.spelled(self.robot)}" for each in self.changes)
        return self.posture.spelled(self.robot) + "".join(changes)

    @cached_property
    def outline(self) -> "Outline":
        """Robot from the side in its posture on the flight, x towards the nose."""
        from kaidan.outline import Outline

        return Outline.of(self.robot, self._on_flight, self.payload)

    @cached_property
    def allowance_d(self) -> Allowance:
        """theta_d as stated, of a yielding track as measured, or by default.

        See ``kaidan.question.yielding.allowance_d``.
        """
        return allowance_d(self)

    def theta_d_at(self, *, L: Any, p: Any, C_L: Any, C_N: Any) -> Any:
        """High end of `allowance_d` of the same robot with other lengths [rad]."""
        return theta_d_at(self, L=L, p=p, C_L=C_L, C_N=C_N)

    @cached_property
    def allowance_M(self) -> Allowance:
        """theta_M likewise; zero when descending without a figure of the question's own."""
        down = self.direction == "down"
        stated = self.theta_M or (None if down else self.robot.theta_M)
        return Allowance.of(stated, name="theta_M", descending=down)

    @property
    def tolerance(self) -> float:
        """How far off their angles the flippers may lie, as stated or by default [rad]."""
        if self.flipper_tolerance is not None:
            return self.flipper_tolerance
        return FLIPPER_TOLERANCE if "flippers" in self.best_of and self.plannable else 0.0

    @property
    def rolling_resistance(self) -> float:
        """Coefficient of rolling resistance as the formulas count it: it works against motion."""
        resistance = self.robot.drive.rolling_resistance
        return resistance if self.direction == "up" else -resistance

    @property
    def kinetic_height(self) -> float:
        """v^2/2g of the stated or the paper's speed [m]."""
        return float(kinetic_energy_height(v=self.speed or ROCKING_SPEED))

    def energy_threshold(self, slip: float = 0.0) -> float:
        """Energy margin below which a sudden stop or start may rock it on its flat [m].

        Parameters
        ----------
        slip : float
            v^2/2g of a slip back onto its grousers, which ends as the belts run [m].
        """
        speed = math.sqrt(2.0 * STANDARD_GRAVITY)
        return float(
            sudden_stop_height(
                v=speed * (math.sqrt(self.kinetic_height) + math.sqrt(slip)),
                lever=self.stance.com_height,
                gyration=self.outline.least_gyration,
            )
        )

    def momentum_threshold(self) -> float:
        """Rise that a robot must have to spare after a drop, beyond all that it dropped [m].

        A sudden stop adds to it; going down, so does the sag of a track that gives theta_d.
        """
        flight = self.steepest_flight
        if self.direction == "up" or flight is None:
            return self.energy_threshold()
        return self.energy_threshold() + float(
            drop_of_sag(
                theta_d=self.allowance_d.high, p=flight.nosing_spacing, theta_s=flight.angle
            )
        )

    @property
    def reserve(self) -> float:
        """Tilt to the fall that a robot that rocks must keep, as stated or by default [rad]."""
        return self.robot.kept_reserve if self.fall_reserve is None else self.fall_reserve

    @cached_property
    def needs(self) -> Needs:
        """Room that the robot needs beside, above and around it."""
        flight = self.steepest_flight
        slope = 0.0 if flight is None else flight.angle
        return needs_of(self.robot, self.postures.values(), self.payload, slope)

    @property
    def narrowest_end(self) -> float:
        """Smallest diameter of a disc of the robot [m]: what the end that it belongs to spans."""
        return 2.0 * min(radius for _, _, radius in self.outline.discs if radius > 0.0)

    @property
    def spread(self) -> tuple[float, ...]:
        """Standard uncertainties of L, C_L, C_N, angle, nosing spacing and friction."""
        of_robot = self.robot.uncertainty
        flight = self.flight
        return (
            of_robot.flat_length,
            of_robot.com_from_front,
            of_robot.com_height,
            flight.uncertainty.angle if flight else 0.0,
            flight.uncertainty.nosing_spacing if flight else 0.0,
            self.surface.friction_uncertainty if self.surface else 0.0,
        )

    @property
    def uncertain(self) -> bool:
        """Whether any input has an uncertainty."""
        return any(self.spread) or self.steps_uncertain

    @property
    def steps_uncertain(self) -> bool:
        """Whether single steps have an uncertainty of their own."""
        return self.profile.covariance is not None
