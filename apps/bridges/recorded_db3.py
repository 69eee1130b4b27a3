"""Messages of a .db3 of ROS 2 (SQLite), as newer versions of RealSense's library write them (2.59 does, 2.55 does not)."""
import sqlite3
from urllib.parse import quote

from recorded_messages import MOST_BYTES, Cut, ros_message

MAGIC = b"SQLite format 3\0"


def messages(path):
    # immutable: no files beside it are looked for or made.
    database = sqlite3.connect(f"file:{quote(str(path))}?mode=ro&immutable=1", uri=True)
    database.text_factory = lambda text: text.decode("utf-8", "replace")
    try:
        database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MOST_BYTES)
        database.execute("PRAGMA trusted_schema = OFF")
        # Views and computed columns could make rows without end out of a small file.
        for table in ("topics", "messages"):
            sql, = database.execute("SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?",
                                    (table,)).fetchone() or ("",)
            if not sql or "AS(" in sql.upper().replace(" ", ""):
                raise Cut("it has no messages of ROS 2")
        topics = {id: (name, kind) for id, name, kind in database.execute("SELECT id, name, type FROM topics")
                  if isinstance(name, str) and isinstance(kind, str)}
        for topic, time_ns, data in database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY id"):
            if topic in topics and isinstance(time_ns, int) and isinstance(data, bytes):
                yield ros_message(*topics[topic], time_ns, data, cdr=True)
    except (sqlite3.Error, UnicodeError) as error:  # the latter where SQLite's own error quotes damaged names
        raise Cut(str(error)) from None
    finally:
        database.close()
