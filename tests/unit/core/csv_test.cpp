#include "libtracker/core/csv.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

class CsvReaderTest : public testing::Test {
 protected:
  CsvReader open(const std::string& text) {
    writeBytes(folder_ / "table.csv", text);
    return CsvReader(folder_ / "table.csv");
  }
  TemporaryFolder folder_;
};

TEST_F(CsvReaderTest, SkipsCommentsAndBlankLinesAndTrimsFields) {
  CsvReader csv = open("# made by hand\n\nframe,x\r\n# more\n 3 , 0.5 \r\n\n4,1.5");
  csv.readHeader({"frame", "x"});
  ASSERT_TRUE(csv.next());
  EXPECT_EQ(csv.integer(0), 3);
  EXPECT_EQ(csv.number(1), 0.5);
  ASSERT_TRUE(csv.next()) << "the last line needs no line end";
  EXPECT_EQ(csv.number(1), 1.5);
  EXPECT_FALSE(csv.next());
}

TEST_F(CsvReaderTest, KeepsEmptyFieldsAndAllowsMoreColumns) {
  CsvReader csv = open("a,b,c\n1,,3,\n");
  csv.readHeader({"a", "b"});
  ASSERT_TRUE(csv.next());
  ASSERT_EQ(csv.fieldCount(), 4U);
  EXPECT_EQ(csv.field(1), "");
  EXPECT_EQ(csv.field(3), "");
}

TEST_F(CsvReaderTest, NamesFileLineAndColumnOfABadField) {
  CsvReader csv = open("# one\nframe,x\n1,2\n2,two\n");
  csv.readHeader({"frame", "x"});
  csv.next();
  csv.next();
  const std::string message = errorOf([&] { (void)csv.number(1); });
  EXPECT_NE(message.find("table.csv: line 4: x must be a number, not 'two'"), std::string::npos) << message;
}

TEST_F(CsvReaderTest, RefusesAnotherHeader) {
  EXPECT_THROW(open("").readHeader({"a"}), Error);
  EXPECT_THROW(open("a\n").readHeader({"a", "b"}), Error);
  EXPECT_THROW(open("b,a\n").readHeader({"a", "b"}), Error);
}

TEST_F(CsvReaderTest, RefusesAShortRow) {
  CsvReader csv = open("a,b,c\n1,2\n");
  csv.readHeader({"a", "b", "c"});
  EXPECT_THROW(csv.next(), Error);
}

TEST_F(CsvReaderTest, RefusesALineWithoutEnd) {
  CsvReader csv = open("a\n" + std::string(3U << 20U, '1') + "\n");
  csv.readHeader({"a"});
  const std::string message = errorOf([&] { csv.next(); });
  EXPECT_NE(message.find("line 2: is too long"), std::string::npos) << message;
}

TEST_F(CsvReaderTest, ShowsBinaryRubbishOnOneLine) {
  CsvReader csv = open(std::string("a\n\x01\x02\xff\n"));
  csv.readHeader({"a"});
  csv.next();
  const std::string message = errorOf([&] { (void)csv.number(0); });
  EXPECT_NE(message.find("must be a number, not '?"), std::string::npos) << message;
}

TEST_F(CsvReaderTest, SaysWhenTheFileIsMissingOrAFolder) {
  EXPECT_NE(errorOf([&] { CsvReader(folder_ / "none.csv"); }).find("No such file"), std::string::npos);
  EXPECT_NE(errorOf([&] { CsvReader reader(folder_.path()); }).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap
