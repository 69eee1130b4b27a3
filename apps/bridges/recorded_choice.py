"""Which topic of a recording holds the depth, and which lens and depth unit belong to it."""
import re
import statistics
from dataclasses import replace

from recorded_messages import DEPTH_FORMS, Cut, DepthUnit, Lens, Picture

# Nanoseconds of the file that are looked at, for the frame rate; more only until depth and lens are found.
ENOUGH_NS = 2 * 10**9
MOST_SHOWN = 120  # characters of a name, in lists and errors
DEFAULT_FPS = 30.0  # where there is one picture only
# Of the usual time between two pictures: files with whole milliseconds differ by 3 %, a lost picture by 100 %.
SAME_GAP = 0.1
# Words of topics whose 16-bit pictures are no depth.
OTHER_PICTURES = re.compile(r"(?<![a-z])(ir|infra\d*|infrared|confidence|amplitude|intensity|disparity|mask)(?![a-z])")
# Depth as seen from another camera has holes, so the one as taken goes first.
WARPED = re.compile(r"aligned|registered")


def shown(name):
    """A name out of a file, safe to print."""
    return "".join(c if c.isprintable() else "?" for c in name[:MOST_SHOWN])


class Topic:
    def __init__(self, name, kind):
        self.name, self.kind = name, kind
        self.count = 0
        self.picture = None  # the first
        self.times_ns = []

    def see(self, message, found):
        self.count += 1
        if isinstance(found, Picture):
            self.picture = self.picture or replace(found, load=None)  # not its pixels
            self.times_ns.append(found.time_ns or message.time_ns)

    def holds_depth(self):
        """Whether its pictures have a form of depth."""
        return self.picture is not None and self.picture.form in DEPTH_FORMS

    def preference(self):
        """Small is good; None: not taken unless it is asked for."""
        words = self.name.lower()
        named = "depth" in words
        if OTHER_PICTURES.search(words) or self.picture.form == "mono16" and not named:
            return None
        return (not named, WARPED.search(words) is not None)

    def fps(self):
        gaps = [b - a for a, b in zip(self.times_ns, self.times_ns[1:]) if b > a]
        if not gaps:
            return DEFAULT_FPS
        usual = statistics.median_low(gaps)
        fps = 1e9 / statistics.mean(gap for gap in gaps if abs(gap - usual) <= SAME_GAP * usual)
        return float(round(fps)) if abs(fps - round(fps)) < 0.01 * fps else fps


def shared(a, b):
    """How many parts of their paths two topics share from the left."""
    count = 0
    for x, y in zip(a.split("/"), b.split("/")):
        if x != y:
            break
        count += 1
    return count


class Survey:
    """What the beginning of a file holds; of the whole file for a list."""

    def __init__(self, messages, path, whole):
        self.path = path
        self.topics, self.lenses, self.units = {}, {}, {}
        self.problems = []
        start_ns = None
        try:
            for message in messages(path):
                self._see(message)
                start_ns = start_ns or message.time_ns
                if not whole and message.time_ns - start_ns > ENOUGH_NS and self._complete():
                    break
        except Cut as cut:
            self.problems.append(shown(str(cut)))

    def _see(self, message):
        topic = self.topics.setdefault(message.topic, Topic(message.topic, message.type))
        found = None
        if message.read and message.topic not in self.lenses:
            try:
                found = message.read()
            except ValueError as error:
                if not topic.count:
                    self.problems.append(shown(f"{message.topic}: {error}"))
        topic.see(message, found)
        if isinstance(found, Lens):
            self.lenses[message.topic] = found
        elif isinstance(found, DepthUnit):
            self.units[message.topic] = found.metres

    def _complete(self):
        depth = self._candidates()
        return bool(depth) and self.lens_topic(depth[0]) is not None

    def _candidates(self):
        found = [topic for topic in self.topics.values() if topic.holds_depth() and topic.preference() is not None]
        return sorted(found, key=Topic.preference)

    def why(self):
        """What was wrong with the file, to be put behind an error."""
        return f" ({self.problems[0]})" if self.problems else ""

    def depth_topic(self, asked):
        """The topic of the depth; raises where there is none."""
        if asked is not None:
            if asked in self.topics and self.topics[asked].holds_depth():
                return self.topics[asked]
            raise RuntimeError(f"{self.path} has no depth pictures in {shown(asked)}; --list says what there is")
        found = self._candidates()
        if not found:
            raise RuntimeError(f"{self.path} has no pictures that are surely depth{self.why()}; --list says what there "
                               "is, --topic takes one")
        return found[0]

    def lens_topic(self, topic):
        """The topic of the lens for pictures of that size, the nearest by name."""
        size = topic.picture.width, topic.picture.height
        fitting = [name for name, lens in self.lenses.items() if (lens.width, lens.height) == size]
        return max(fitting, key=lambda name: shared(name, topic.name), default=None)

    def unit_m(self, topic):
        """Metres a step: 1 mm unless the file tells it."""
        if topic.picture.form == "32FC1" or not self.units:
            return 0.001
        return self.units[max(self.units, key=lambda name: shared(name, topic.name))]

    def lines(self):
        for topic in self.topics.values():
            picture = topic.picture
            size = f", {picture.width} x {picture.height} {shown(picture.form)}" if picture else ""
            yield f"{shown(topic.name)}: {topic.count} of {shown(topic.kind)}{size}"
        try:
            topic = self.depth_topic(None)
            yield f"taken: {shown(topic.name)}, lens of {shown(self.lens_topic(topic) or 'no topic: --camera is needed')}"
        except RuntimeError as error:
            yield str(error)
        yield from (f"damaged: {problem}" for problem in self.problems)
