r"""How far behind the drawn pose a robot may stand once its flippers have moved.

::

     before   o=====o        after   o==.           the tip slides over the ground as it comes
              .-----'  flipper           '.  flipper  down, or the tracks do, or both in part:
     ---------'                ---------'  o         which of them it is, friction decides

The tracks are drawn where they are along the ground. But the distance between what the robot stands
on changes as its flippers turn, so that one of its two contacts slides, whichever friction holds
less. The drawn poses are one way between two: either contact may be the one that stays, and now the
one, now the other. So at every turn the one counts whose belt ran ahead by more.
"""

from kaidan import contact


def drift(path: contact.Path) -> float:
    """Distance by which it may stand behind where it is drawn [m], at least zero.

    path: a pose for each posture.
    """
    return float(max(0.0, contact.belt_slides(path).max(axis=1).sum()))
