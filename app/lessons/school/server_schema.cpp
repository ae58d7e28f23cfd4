#include "app/lessons/school/server_schema.h"

#include <fmt/format.h>

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/exchange.h"
#include "app/lessons/history/schema.h"

namespace gearshift::lessons {
namespace {

constexpr SqlDialect kPostgres{"bigint PRIMARY KEY", "bigint", "double precision"};

// Roles belong to the whole server, so another database may have made them.
constexpr const char* kRoles = R"sql(
DO $$ BEGIN
  IF current_setting('server_encoding') <> 'UTF8' THEN RAISE EXCEPTION 'the database must use the encoding UTF8'; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'gearshift_seat') THEN CREATE ROLE gearshift_seat NOLOGIN; END IF;
  IF NOT EXISTS (SELECT FROM pg_roles WHERE rolname = 'gearshift_instructor') THEN
    CREATE ROLE gearshift_instructor NOLOGIN;
  END IF;
END $$;
)sql";

// learner.version counts the documents of a learner. The row stays locked until the transaction commits, so the versions
// that `fetch_learner` sees are complete up to the largest one; a sequence would not be. Each row has the version of the document
// that wrote it last, and the seat that sent it (`writer`). `alias` gives the learner of each number that a seat has sent:
// learners of the same name are one. Of an erased learner only these numbers and a hash of the name stay, so that no seat
// can bring the learner back.
constexpr const char* kTables = R"sql(
ALTER TABLE learner ADD COLUMN version bigint NOT NULL DEFAULT 0;
ALTER TABLE session ADD COLUMN version bigint NOT NULL, ADD COLUMN writer bigint NOT NULL;
ALTER TABLE lesson_run ADD COLUMN version bigint NOT NULL, ADD COLUMN writer bigint NOT NULL;
ALTER TABLE comment ADD COLUMN version bigint NOT NULL, ADD COLUMN writer bigint NOT NULL;
CREATE INDEX comment_of_run ON comment (run);
CREATE TABLE alias (id bigint PRIMARY KEY, learner bigint NOT NULL REFERENCES learner ON DELETE CASCADE);
CREATE INDEX alias_of_learner ON alias (learner);
CREATE TABLE erased (id bigint PRIMARY KEY);
CREATE TABLE erased_name (hash bytea PRIMARY KEY, at text NOT NULL, seat bigint NOT NULL);
CREATE TABLE deleted_comment (
  id bigint PRIMARY KEY, learner bigint NOT NULL REFERENCES learner ON DELETE CASCADE,
  version bigint NOT NULL, writer bigint NOT NULL);
CREATE TABLE seat (
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, token text NOT NULL UNIQUE, login text NOT NULL,
  host text NOT NULL, sends bigint NOT NULL DEFAULT 0, mark text NOT NULL DEFAULT '',
  seen timestamptz NOT NULL DEFAULT now());
CREATE TABLE school (id text NOT NULL, version integer NOT NULL);
INSERT INTO school VALUES (gen_random_uuid()::text, 0);
)sql";

// Parameters of functions begin with an underscore. {...} are the lists of columns; `per` rows have numbers of one seat.
constexpr const char* kFunctions = R"sql(
CREATE OR REPLACE FUNCTION schema_version() RETURNS integer LANGUAGE sql STABLE SECURITY DEFINER
SET search_path = gearshift, pg_temp AS 'SELECT version FROM school';

CREATE OR REPLACE FUNCTION hello(_token text, _host text) RETURNS jsonb LANGUAGE plpgsql SECURITY DEFINER
SET search_path = gearshift, pg_temp AS $$
DECLARE s seat;
BEGIN
  UPDATE seat SET seen = now(), host = _host WHERE token = _token AND login = session_user RETURNING * INTO s;
  IF NOT FOUND THEN INSERT INTO seat (token, login, host) VALUES (_token, session_user, _host) RETURNING * INTO s; END IF;
  RETURN jsonb_build_object('school', (SELECT id FROM school), 'seat', s.number, 'sends', s.sends, 'mark', s.mark);
EXCEPTION WHEN unique_violation THEN
  RAISE EXCEPTION 'the history belongs to a seat with another login at the server' USING ERRCODE = 'GS002';
END $$;

-- True if the login may read and write the learner with this number: a seat its own ones, an instructor all.
CREATE OR REPLACE FUNCTION may_use(_seat bigint, _learner bigint) RETURNS boolean LANGUAGE sql STABLE
SET search_path = gearshift, pg_temp AS $$
  SELECT pg_has_role(session_user, 'gearshift_instructor', 'member') OR (_seat > 0 AND (_learner / {per} = _seat OR
    EXISTS (SELECT FROM alias WHERE learner = _learner AND id / {per} = _seat)));
$$;

-- Counts a document of the seat. Refuses it if a copy of the seat's history has sent one meanwhile.
CREATE OR REPLACE FUNCTION open_seat(_token text, _sends bigint, _mark text) RETURNS seat LANGUAGE plpgsql
SET search_path = gearshift, pg_temp AS $$
DECLARE s seat;
BEGIN
  UPDATE seat SET sends = sends + 1, mark = _mark, seen = now()
    WHERE token = _token AND login = session_user AND sends = _sends RETURNING * INTO s;
  IF NOT FOUND THEN
    RAISE EXCEPTION 'another copy of the history has sent results as this seat' USING ERRCODE = 'GS002';
  END IF;
  RETURN s;
END $$;

CREATE OR REPLACE FUNCTION send_rows(_token text, _sends bigint, _mark text, _document jsonb) RETURNS void
LANGUAGE plpgsql SECURITY DEFINER SET search_path = gearshift, pg_temp AS $$
DECLARE
  s seat := open_seat(_token, _sends, _mark);
  l jsonb := _document -> 'learner';
  _asked bigint := (l ->> 'id')::bigint;
  _learner bigint;
  _version bigint;
  _count bigint;
BEGIN
  IF NOT may_use(s.number, _asked) THEN
    RAISE EXCEPTION 'this login may not write for the learner' USING ERRCODE = 'insufficient_privilege';
  END IF;
  IF EXISTS (SELECT FROM erased WHERE id = _asked) THEN RETURN; END IF;
  SELECT learner INTO _learner FROM alias WHERE id = _asked;
  IF NOT FOUND THEN
    -- On the seat that erased the name, a new learner of that name can only have been made afterwards.
    IF EXISTS (SELECT FROM erased_name n WHERE n.hash = sha256(convert_to(l ->> 'name', 'UTF8'))
               AND n.at >= l ->> 'made_at' AND n.seat <> s.number) THEN
      INSERT INTO erased VALUES (_asked);
      RETURN;
    END IF;
    INSERT INTO learner (id, name, made_at, next_lesson) VALUES (_asked, l ->> 'name', l ->> 'made_at', l ->> 'next_lesson')
      ON CONFLICT (name) DO NOTHING;
    SELECT id INTO _learner FROM learner WHERE name = l ->> 'name';
    INSERT INTO alias VALUES (_asked, _learner);
  ELSIF (l -> 'changed')::boolean THEN
    UPDATE learner SET next_lesson = l ->> 'next_lesson',
      name = CASE WHEN EXISTS (SELECT FROM learner o WHERE o.name = l ->> 'name' AND o.id <> _learner) THEN name
             ELSE l ->> 'name' END
      WHERE id = _learner;
  END IF;
  UPDATE learner SET version = version + 1 WHERE id = _learner RETURNING version INTO _version;
  IF NOT FOUND THEN
    RAISE EXCEPTION 'the learner was erased meanwhile' USING ERRCODE = 'serialization_failure';
  END IF;

  INSERT INTO session (id, learner, begun_at, program, version, writer)
    SELECT id, _learner, begun_at, program, _version, s.number
    FROM jsonb_populate_recordset(NULL::session, _document -> 'sessions') ON CONFLICT (id) DO NOTHING;
  INSERT INTO lesson_run ({run}, version, writer)
    SELECT {run}, _version, s.number FROM jsonb_populate_recordset(NULL::lesson_run, _document -> 'runs') r
    WHERE id / {per} = s.number AND session IN (SELECT x.id FROM session x WHERE x.learner = _learner)
    ON CONFLICT (id) DO UPDATE SET {run_changes}, version = excluded.version, writer = excluded.writer;
  GET DIAGNOSTICS _count = ROW_COUNT;
  IF _count <> jsonb_array_length(_document -> 'runs') THEN
    RAISE EXCEPTION 'a run does not belong to this seat and learner' USING ERRCODE = 'insufficient_privilege';
  END IF;
  DELETE FROM shift WHERE run IN (SELECT (r ->> 'id')::bigint FROM jsonb_array_elements(_document -> 'runs') r);
  DELETE FROM driving_error WHERE run IN (SELECT (r ->> 'id')::bigint FROM jsonb_array_elements(_document -> 'runs') r);
  INSERT INTO shift (run, {shift}) SELECT run, {shift}
    FROM jsonb_populate_recordset(NULL::shift, _document -> 'shifts') WHERE run / {per} = s.number;
  INSERT INTO driving_error (run, number, {error}) SELECT run, number, {error}
    FROM jsonb_populate_recordset(NULL::driving_error, _document -> 'errors') WHERE run / {per} = s.number;
  INSERT INTO comment (id, run, made_at, author, text, edited_at, version, writer)
    SELECT c.id, c.run, c.made_at, c.author, c.text, c.edited_at, _version, s.number
    FROM jsonb_populate_recordset(NULL::comment, _document -> 'comments') c
    WHERE c.run IN (SELECT r.id FROM lesson_run r JOIN session x ON x.id = r.session WHERE x.learner = _learner)
      AND (c.id / {per} = s.number OR EXISTS (SELECT FROM comment o WHERE o.id = c.id AND o.run = c.run))
      AND NOT EXISTS (SELECT FROM deleted_comment d WHERE d.id = c.id)
    ON CONFLICT (id) DO UPDATE SET text = excluded.text, edited_at = excluded.edited_at, version = excluded.version,
      writer = excluded.writer;
END $$;

CREATE OR REPLACE FUNCTION delete_comment(_token text, _sends bigint, _mark text, _comment bigint) RETURNS void
LANGUAGE plpgsql SECURITY DEFINER SET search_path = gearshift, pg_temp AS $$
DECLARE
  s seat := open_seat(_token, _sends, _mark);
  _learner bigint;
  _version bigint;
BEGIN
  SELECT x.learner INTO _learner FROM comment c JOIN lesson_run r ON r.id = c.run JOIN session x ON x.id = r.session
    WHERE c.id = _comment;
  IF NOT FOUND THEN RETURN; END IF;
  IF NOT may_use(s.number, _learner) THEN
    RAISE EXCEPTION 'this login may not write for the learner' USING ERRCODE = 'insufficient_privilege';
  END IF;
  UPDATE learner SET version = version + 1 WHERE id = _learner RETURNING version INTO _version;
  DELETE FROM comment WHERE id = _comment;
  INSERT INTO deleted_comment VALUES (_comment, _learner, _version, s.number) ON CONFLICT DO NOTHING;
END $$;

CREATE OR REPLACE FUNCTION erase_learner(_token text, _sends bigint, _mark text, _asked bigint) RETURNS void
LANGUAGE plpgsql SECURITY DEFINER SET search_path = gearshift, pg_temp AS $$
DECLARE
  s seat := open_seat(_token, _sends, _mark);
  _learner bigint;
BEGIN
  IF NOT may_use(s.number, _asked) THEN
    RAISE EXCEPTION 'this login may not erase the learner' USING ERRCODE = 'insufficient_privilege';
  END IF;
  SELECT l.id INTO _learner FROM learner l WHERE l.id = (SELECT a.learner FROM alias a WHERE a.id = _asked) FOR UPDATE;
  INSERT INTO erased SELECT id FROM alias WHERE learner = _learner UNION SELECT _asked ON CONFLICT DO NOTHING;
  INSERT INTO erased_name SELECT sha256(convert_to(name, 'UTF8')),
      to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'), s.number FROM learner WHERE id = _learner
    ON CONFLICT (hash) DO UPDATE SET at = excluded.at, seat = excluded.seat;
  DELETE FROM learner WHERE id = _learner;
END $$;

-- Returns the document of the first learner in `_wanted` ([{"learner": number, "version": known version}]) who has
-- changed since, with the rows that other seats wrote; NULL if none has.
CREATE OR REPLACE FUNCTION fetch_learner(_token text, _wanted jsonb) RETURNS jsonb
LANGUAGE plpgsql STABLE SECURITY DEFINER SET search_path = gearshift, pg_temp AS $$
DECLARE
  _seat bigint := coalesce((SELECT number FROM seat WHERE token = _token AND login = session_user), 0);
  _asked bigint;
  _known bigint;
  l learner;
BEGIN
  FOR _asked, _known IN SELECT (w ->> 'learner')::bigint, (w ->> 'version')::bigint FROM jsonb_array_elements(_wanted) w
  LOOP
    IF NOT may_use(_seat, _asked) THEN
      RAISE EXCEPTION 'this login may not read the learner' USING ERRCODE = 'insufficient_privilege';
    END IF;
    IF EXISTS (SELECT FROM erased WHERE id = _asked) THEN
      RETURN jsonb_build_object('asked', _asked, 'erased', true);
    END IF;
    SELECT x.* INTO l FROM learner x WHERE x.id = (SELECT learner FROM alias WHERE id = _asked) AND x.version <> _known;
    CONTINUE WHEN NOT FOUND;
    -- A server that was restored from a backup may know less than the seat.
    IF l.version < _known THEN _known := 0; END IF;
    RETURN jsonb_build_object('asked', _asked, 'erased', false, 'learner', to_jsonb(l),
      'sessions', coalesce((SELECT jsonb_agg(x) FROM session x
         WHERE learner = l.id AND version > _known AND writer <> _seat), '[]'),
      'runs', coalesce((SELECT jsonb_agg(r) FROM lesson_run r JOIN session x ON x.id = r.session
         WHERE x.learner = l.id AND r.version > _known AND r.writer <> _seat), '[]'),
      'shifts', coalesce((SELECT jsonb_agg(p) FROM shift p JOIN lesson_run r ON r.id = p.run JOIN session x
         ON x.id = r.session WHERE x.learner = l.id AND r.version > _known AND r.writer <> _seat), '[]'),
      'errors', coalesce((SELECT jsonb_agg(p) FROM driving_error p JOIN lesson_run r ON r.id = p.run JOIN session x
         ON x.id = r.session WHERE x.learner = l.id AND r.version > _known AND r.writer <> _seat), '[]'),
      'comments', coalesce((SELECT jsonb_agg(c) FROM comment c JOIN lesson_run r ON r.id = c.run JOIN session x
         ON x.id = r.session WHERE x.learner = l.id AND c.version > _known AND c.writer <> _seat), '[]'),
      'deleted_comments', coalesce((SELECT jsonb_agg(d.id) FROM deleted_comment d
         WHERE d.learner = l.id AND d.version > _known AND d.writer <> _seat), '[]'));
  END LOOP;
  RETURN NULL;
END $$;

CREATE OR REPLACE FUNCTION learners() RETURNS jsonb LANGUAGE sql STABLE SECURITY DEFINER
SET search_path = gearshift, pg_temp AS $$
  SELECT coalesce(jsonb_agg(id ORDER BY name), '[]') FROM learner;
$$;

CREATE OR REPLACE FUNCTION summary() RETURNS text LANGUAGE sql STABLE SECURITY DEFINER
SET search_path = gearshift, pg_temp AS $$
  SELECT format(E'%s learners, %s runs, %s shifts, %s comments, %s erased learners\n', (SELECT count(*) FROM learner),
      (SELECT count(*) FROM lesson_run), (SELECT count(*) FROM shift), (SELECT count(*) FROM comment),
      (SELECT count(*) FROM erased_name)) ||
    coalesce(string_agg(format(E'seat %s  %s  %s runs  last seen %s UTC\n', number, host,
      (SELECT count(*) FROM lesson_run r WHERE r.id / {per} = seat.number),
      to_char(seen AT TIME ZONE 'UTC', 'YYYY-MM-DD HH24:MI')), '' ORDER BY number), '') FROM seat
    WHERE EXISTS (SELECT FROM lesson_run r WHERE r.id / {per} = seat.number);
$$;
)sql";

constexpr const char* kGrants = R"sql(
REVOKE ALL ON ALL FUNCTIONS IN SCHEMA gearshift FROM PUBLIC;
GRANT USAGE ON SCHEMA gearshift TO gearshift_seat, gearshift_instructor;
GRANT EXECUTE ON FUNCTION schema_version(), hello(text, text), send_rows(text, bigint, text, jsonb),
  delete_comment(text, bigint, text, bigint), erase_learner(text, bigint, text, bigint), fetch_learner(text, jsonb)
  TO gearshift_seat, gearshift_instructor;
GRANT EXECUTE ON FUNCTION learners(), summary() TO gearshift_instructor;
GRANT SELECT ON ALL TABLES IN SCHEMA gearshift TO gearshift_instructor;
)sql";

template <class Record>
std::string names_of(const char* format) {
  std::string names;
  each_field(Record(), [&](const RecordField& field, const auto&) {
    names += (names.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), field.name);
  });
  return names;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string functions() {
  std::string text = kFunctions;
  text = replaced(text, "{per}", std::to_string(kRowsPerSeat));
  text = replaced(text, "{run}", "id, session, begun_at, recording, kept_at, " + names_of<LessonResult>("{}"));
  text = replaced(
      text, "{run_changes}",
      "recording = excluded.recording, kept_at = excluded.kept_at, " + names_of<LessonResult>("{0} = excluded.{0}"));
  text = replaced(text, "{shift}", names_of<ShiftRecord>("{}"));
  return replaced(text, "{error}", names_of<DrivingError>("{}"));
}

}  // namespace

std::string server_script() {
  return fmt::format(
      "BEGIN; {} CREATE SCHEMA IF NOT EXISTS gearshift; SET LOCAL search_path = gearshift;\n"
      "DO $make$ BEGIN IF to_regclass('gearshift.school') IS NULL THEN {} {} END IF; END $make$;\n"
      "ALTER TABLE lesson_run ADD COLUMN IF NOT EXISTS pedal_corrections_per_s double precision;\n"
      "{}\nUPDATE school SET version = {};\n{} COMMIT;",
      kRoles, learner_tables(kPostgres), kTables, functions(), kServerVersion, kGrants);
}

}  // namespace gearshift::lessons
