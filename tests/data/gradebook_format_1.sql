BEGIN TRANSACTION;
CREATE TABLE current (
	student VARCHAR NOT NULL, 
	sheet VARCHAR NOT NULL, 
	submission VARCHAR NOT NULL, 
	rules VARCHAR NOT NULL, 
	PRIMARY KEY (student, sheet)
);
INSERT INTO "current" VALUES('ada','one','f09acb8c8ce22ce54ea640d81ede81f2','ecd99c7341e0085ebf3795ef9583d838');
INSERT INTO "current" VALUES('ben','one','aa7875e66612b37b0d249c05c0205143','ba90330a9f7c36bc9bc72f1c00a3e3fc');
CREATE TABLE grade (
	student VARCHAR NOT NULL, 
	sheet VARCHAR NOT NULL, 
	submission VARCHAR NOT NULL, 
	rules VARCHAR NOT NULL, 
	verdicts TEXT NOT NULL, 
	PRIMARY KEY (student, sheet, submission, rules)
);
INSERT INTO "grade" VALUES('ada','one','f09acb8c8ce22ce54ea640d81ede81f2','ecd99c7341e0085ebf3795ef9583d838','[{"part": "lever_p", "status": "correct", "points": 2.0, "out_of": 2, "findings": [], "reading": "", "right": [true, true], "answer": [0.3446611873708787, 0.7440488330211237]}, {"part": "lever_J", "status": "correct", "points": 3.0, "out_of": 3, "findings": [], "reading": "", "right": [true, true], "answer": [-0.7440488330211237, 0.3446611873708787]}]');
INSERT INTO "grade" VALUES('ben','one','c6753701cce23439206a3508423c6557','ba90330a9f7c36bc9bc72f1c00a3e3fc','[{"part": "lever_p", "status": "incorrect", "points": 0.0, "out_of": 2, "findings": [], "reading": "", "right": [false, false], "answer": [9.0, 9.0]}, {"part": "lever_J", "status": "failed", "points": 0.0, "out_of": 3, "findings": [{"text": "Takes numbers of shape (2,), got text: what\u0000 is ''this'' \u00d8.\nwhat  is ''this'' \u00d8\n    ^", "private": false}], "reading": "", "right": null, "answer": null}]');
INSERT INTO "grade" VALUES('ben','one','aa7875e66612b37b0d249c05c0205143','ba90330a9f7c36bc9bc72f1c00a3e3fc','[{"part": "lever_p", "status": "incorrect", "points": 0.0, "out_of": 2, "findings": [], "reading": "", "right": [false, false], "answer": [1.0, 2.0]}, {"part": "lever_J", "status": "correct", "points": 3.0, "out_of": 3, "findings": [], "reading": "", "right": [true, true], "answer": [-0.5981464031765841, 0.9822020567922444]}]');
CREATE TABLE mark (
	student VARCHAR NOT NULL, 
	sheet VARCHAR NOT NULL, 
	part VARCHAR NOT NULL, 
	points FLOAT NOT NULL, 
	comment TEXT NOT NULL, 
	answer VARCHAR NOT NULL, 
	PRIMARY KEY (student, sheet, part)
);
INSERT INTO "mark" VALUES('ada','one','lever_p',1.5,'neat; it''s "good"','abcd1234');
CREATE TABLE meta (
	"key" VARCHAR NOT NULL, 
	value VARCHAR NOT NULL, 
	PRIMARY KEY ("key")
);
INSERT INTO "meta" VALUES('format','1');
CREATE TABLE record (
	student VARCHAR NOT NULL, 
	sheet VARCHAR NOT NULL, 
	exercise VARCHAR NOT NULL, 
	attempt INTEGER NOT NULL, 
	numbers TEXT NOT NULL, 
	answers TEXT NOT NULL, 
	PRIMARY KEY (student, sheet, exercise)
);
INSERT INTO "record" VALUES('ada','one','lever',0,'{"L": 0.82, "q": [1.137]}','{"lever_p": [0.344661187, 0.744048833], "lever_J": [-0.744048833, 0.344661187]}');
INSERT INTO "record" VALUES('ben','one','lever',0,'{"L": 1.15, "q": [0.547]}','{"lever_p": [0.982202057, 0.598146403], "lever_J": [-0.598146403, 0.982202057]}');
INSERT INTO "record" VALUES('cyd','one','lever',0,'{"L": 0.59, "q": [0.418]}','{"lever_p": [0.539202554, 0.239500742], "lever_J": [-0.239500742, 0.539202554]}');
COMMIT;
