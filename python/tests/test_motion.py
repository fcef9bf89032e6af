"""Traces, configurations, proofs and simulations."""

import kutzbach
import numpy
import pytest


def test_a_trace_is_arrays(linkage: kutzbach.Mechanism) -> None:
    motion = kutzbach.trace(linkage, drive="main", samples=50)
    assert motion.moves and len(motion) == 50
    assert motion.values.shape == (50, 4)
    assert motion.poses.shape == (50, 4, 7)
    assert (motion.driven, motion.variables) == ("main", ("main", "pivot", "pin", "end"))
    assert numpy.array_equal(motion.value("main"), motion.drive)
    assert motion.closure.max() < 1e-12
    # The loop closes at every sample: the end of the coupler is the end of the rocker.
    assert numpy.allclose(end(motion.pose("coupler"), (3.5, 0)), end(motion.pose("rocker"), (0, 2)), atol=1e-9)
    assert numpy.allclose(numpy.linalg.norm(motion.poses[:, :, 3:], axis=2), 1)
    with pytest.raises(KeyError):
        motion.value("nothing")
    with pytest.raises(KeyError):
        motion.pose("nothing")


def end(poses: numpy.ndarray, at: tuple[float, float]) -> numpy.ndarray:
    """Where a point of a link is that turns about z."""
    angle = 2 * numpy.arctan2(poses[:, 6], poses[:, 3])
    x = poses[:, 0] + at[0] * numpy.cos(angle) - at[1] * numpy.sin(angle)
    y = poses[:, 1] + at[0] * numpy.sin(angle) + at[1] * numpy.cos(angle)
    return numpy.stack([x, y], axis=1)


def test_a_range_is_followed(linkage: kutzbach.Mechanism) -> None:
    motion = kutzbach.trace(linkage, drive="main", range=(0.5, 1.5), samples=11)
    assert motion.drive == pytest.approx(numpy.linspace(0.5, 1.5, 11))


def test_what_stands_still_says_why(linkage_text: str) -> None:
    apart = kutzbach.trace(kutzbach.load(linkage_text, crank=20))
    assert not apart.moves and apart.reason
    assert apart.values.shape[0] == 0 and apart.poses.shape[0] == 0
    assert apart.to_dict()["moves"] is False


def test_unknown_joints_are_errors(linkage: kutzbach.Mechanism) -> None:
    with pytest.raises(kutzbach.MechanismError, match="`mian`"):
        kutzbach.trace(linkage, drive="mian")
    with pytest.raises(kutzbach.MechanismError, match="samples"):
        kutzbach.trace(linkage, samples=1)


def test_both_ways_of_assembly_are_found(linkage: kutzbach.Mechanism) -> None:
    found = kutzbach.assemble(linkage, hold={"main": "pi/3"})
    assert found.proven and len(found) == 2
    assert found.held == {"main": pytest.approx(numpy.pi / 3)}
    assert all(values["main"] == pytest.approx(numpy.pi / 3) for values in found.joints)
    with pytest.raises(kutzbach.MechanismError, match="no joint"):
        kutzbach.assemble(linkage, hold={"mian": 0})
    with pytest.raises(kutzbach.MechanismError, match="no value"):
        kutzbach.assemble(linkage, hold={"main": "abc+"})


def test_polynomials_prove_the_dimension(linkage: kutzbach.Mechanism) -> None:
    proof = kutzbach.exact(linkage)
    assert (proof.outcome, proof.dimension) == ("done", 1)


def test_an_engine_confirms_the_motion(linkage: kutzbach.Mechanism) -> None:
    assert kutzbach.simulate(linkage, budget=5).outcome == "confirmed"
